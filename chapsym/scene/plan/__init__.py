"""What a scene asks for, by which model, and what it costs."""
