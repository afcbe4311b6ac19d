"""Courses in the console: their files, the conditions of their steps, what a student has done, and grading."""
