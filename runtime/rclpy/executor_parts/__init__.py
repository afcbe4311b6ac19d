"""What the executors are made of."""
