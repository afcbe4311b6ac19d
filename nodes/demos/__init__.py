"""The nodes of the ROS 2 tutorials, one folder per package; the importer provides this package as
`bot_console_demos`.
"""
