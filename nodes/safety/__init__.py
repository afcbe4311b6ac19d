"""What the safety monitor decides: who may drive, how near things are, and the emergency stop."""
