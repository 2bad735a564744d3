"""Depth from a rectified pair: costs, and ways to choose by them.

- `cost_volume`: the cost volume: how badly every left pixel matches each of its candidates in the
  right picture.
- `disparity`: the whole way from two pictures to disparities and depths, in steps.
- `disparity_map`: disparity maps: chosen from costs, checked against the right picture, refined
  between pixels, smoothed and filled.
- `semiglobal`: semi-global matching: smooth a cost volume along eight straight paths through
  every pixel, then add the paths up.
"""
