"""`bot-console tune`: the values of parameters for which the simulated robot does best."""
