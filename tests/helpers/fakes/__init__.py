"""Scripted replacements for the systems that the console talks to: a console, a launcher, a ROS 2 installation."""
