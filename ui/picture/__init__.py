"""The camera picture and what is drawn over it."""
