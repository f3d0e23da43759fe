"""Two sessions side by side: pictures in step, mean repetitions over each other, differences beyond error."""
