"""Which gains may be used: conditions of a study's theorem at a point, over boxes, and on a fleet's graph."""
