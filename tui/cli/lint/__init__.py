"""`bot-console lint`: what parameters leave unsaid, in source files, parameter files, and what runs."""
