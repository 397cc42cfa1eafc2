"""The names of scikit-sparse 0.4 on sparse_local: sparse_local.sksparse.cholmod."""
