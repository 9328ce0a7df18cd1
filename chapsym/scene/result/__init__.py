"""The results of runs: data sets, file formats, a summary."""
