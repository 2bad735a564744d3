"""What runs in a student's process: all of ours in its sight; none of it knows an answer."""
