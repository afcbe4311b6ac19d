"""`bot-console lint`: finds parameters without description, range or unit, in source, parameter files and running
nodes.
"""
