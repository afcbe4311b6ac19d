"""Topics as the console watches and uses them: measured, read, published; services called, goals sent."""
