def sentences(found): return []
