"""What the nodes of this package share: parameters, scans, diagnostics, and a life from start to end."""
