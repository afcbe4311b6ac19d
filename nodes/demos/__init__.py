"""The nodes of the ROS 2 tutorials, one folder for each package; the importer provides them as the package
`bot_console_demos`.
"""
