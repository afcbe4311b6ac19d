"""The bus beyond one process: Zenoh, in the wire format of rmw_zenoh."""
