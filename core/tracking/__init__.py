"""The tracker: motion and measurement models, unscented filter, association, smoother."""
