"""`bot-console check`: a script that does and expects what a person would at the screen."""
