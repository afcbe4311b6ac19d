"""`bot-console check`: runs a script of actions and expectations, as a person would carry them out at the screen."""
