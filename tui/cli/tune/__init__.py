"""`bot-console tune`: finds the parameter values with which the simulated robot scores best."""
