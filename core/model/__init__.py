"""Values that all stages share: types, camera, rotations, hand, errors, names."""
