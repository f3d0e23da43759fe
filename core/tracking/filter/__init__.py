"""The filter: state models of palm and digits, sigma points, prediction, correction."""
