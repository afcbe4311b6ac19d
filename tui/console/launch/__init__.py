"""The console's launcher, which runs and controls processes through the public launch API."""
