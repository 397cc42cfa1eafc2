"""The names of scikit-sparse 0.5 on sparse_local: sksparse05.cholmod and sksparse05.amd."""
