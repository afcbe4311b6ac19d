"""`bot-console lint`: parameters without description, range or unit, in source and parameter files and in what runs."""
