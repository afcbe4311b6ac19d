"""The packages `action_tutorials_py` and `action_tutorials_cpp`: a Fibonacci sequence as an action."""
