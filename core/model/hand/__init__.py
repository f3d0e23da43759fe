"""The hand: marker protocols, anatomy, kinematics, clinical angles."""
