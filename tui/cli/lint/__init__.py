"""`bot-console lint`: finds parameters without a description, range or unit, in source and parameter files and in
running nodes.
"""
