"""Courses in the console: their files, the conditions of their steps, a student's progress, and grading."""
