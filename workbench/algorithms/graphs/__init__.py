"""On graphs.

- `diffusion`: heat flows, surfaces grow smooth and shrink.
- `spectral_cut`: a graph cut in two along its Fiedler vector.
"""
