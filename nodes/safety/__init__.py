"""The safety monitor's decisions: who may drive, how close obstacles are, and the emergency stop."""
