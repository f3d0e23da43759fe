"""Messages of three ranks: stops you, stays with the task, tells you. No toasts, no OK buttons."""
