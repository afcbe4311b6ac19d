"""Parses what people type into fields: expressions, units, one line of YAML."""
