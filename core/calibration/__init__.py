"""From clicks on the first frame to the hand's geometry and the neutral pose, with a verdict."""
