"""The data as a package of its own for tests of engines, chapsym-rolling: `python -m benchmarks.rolling.wheel`."""
