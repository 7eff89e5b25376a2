"""The rules of arguments about all solutions of a closed loop, one theorem in each file."""
