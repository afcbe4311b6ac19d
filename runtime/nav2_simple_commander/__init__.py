"""Nav2's goals as method calls, under the names of upstream's package."""
