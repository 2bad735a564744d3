"""Small networks, and what they learn about shapes.

- `perceptron`: a multilayer perceptron and Adam, written out.
- `point_net`: PointNet: a network for each point, one pooling, a network for what is pooled.
- `graph_network`: graph convolutional networks.
- `neural_field`: a network that gives the signed distance of any point.
- `radiance_field`: density and colour on a grid in the plane, learned from photographs.
- `rotation_regression`: a network that tells by how much its input is turned.
- `set_regression`: points that are to be like every one of many targets at once.
- `mesh_fitting`: a mesh whose vertices move until it fits given points.
"""
