"""What people type into fields, read: expressions, units, one line of YAML."""
