"""Scripted replacements for what the console talks to: a console, a launcher, a ROS 2 installation."""
