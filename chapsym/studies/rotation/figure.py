def save_figures(found, folder): return []
