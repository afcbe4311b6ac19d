"""`bot-console check`: runs a script of actions and expectations that a person could also carry out at the screen."""
