"""On graphs: diffusion, and cuts by spectra.

- `diffusion`: what a Laplacian does when it is applied again and again: heat flows, surfaces grow
  smooth and shrink.
- `spectral_cut`: spectral clustering of a graph into two: the Fiedler vector, the cut by its
  sign, and the best of all cuts along it.
"""
