"""Depth from a rectified pair: costs, and ways to choose by them.

- `cost_volume`: how badly every left pixel matches each of its candidates.
- `disparity`: the whole way from two pictures to disparities and depths, in steps.
- `disparity_map`: maps chosen from costs, checked, refined between pixels, filled.
- `semiglobal`: a cost volume smoothed along eight straight paths through every pixel.
"""
