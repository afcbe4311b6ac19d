"""What the nodes of this package share: parameters, scans, diagnostics, and startup and shutdown."""
