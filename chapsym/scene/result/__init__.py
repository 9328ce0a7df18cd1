"""What a run gives: data sets, file formats, a summary."""
