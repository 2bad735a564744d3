"""Small networks, and what they learn about shapes.

- `perceptron`: A multilayer perceptron and Adam: forward, backward and the step, written out,
  with all numbers of a network in one row.
- `point_net`: pointNet: a network for each point, one pooling over all points, a network for what
  is pooled.
- `graph_network`: graph convolutional networks: one layer in its parts, many layers in a row, and
  training by gradient descent.
- `neural_field`: A neural field: a small network that is trained to give the signed distance of
  any point, gradients written by hand.
- `radiance_field`: A radiance field on a grid in the plane: density and colour that are learned
  from photographs alone.
- `rotation_regression`: A network that tells by how much its input is turned, trained with one
  representation of rotations or another.
- `set_regression`: A set of points that is to be like every one of many targets at once: what
  remains is what the loss calls the mean.
- `mesh_fitting`: A mesh whose vertices move until points on it lie where given points lie, held
  together by terms that know no data.
"""
