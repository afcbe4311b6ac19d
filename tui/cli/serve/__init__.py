"""`bot-console serve`: the console in a browser tab."""
