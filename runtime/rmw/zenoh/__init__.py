"""The inter-process bus: Zenoh, in the wire format of rmw_zenoh."""
