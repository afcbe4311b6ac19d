"""Connections to other machines: a client of a Zenoh router, and a router of our own."""
