"""What serves research alone and stands above the pipeline, which knows none of it."""
