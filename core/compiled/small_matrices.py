"""Products and roots of matrices too small for a call of BLAS, for the other compiled modules.

Each writes into an array that its caller gives; ``small_matrices.pxd`` says which types they take.
"""

import cython
from cython.cimports.libc.math import sqrt


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_product(
    a: cython.const[cython.double][:, ::1], b: cython.const[cython.double][:, ::1], out: cython.double[:, ::1]
) -> cython.void:
    """``out`` += A B; zeros of A cost nothing."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for i in range(a.shape[0]):
        for k in range(a.shape[1]):
            x = a[i, k]
            if x != 0.0:
                for j in range(b.shape[1]):
                    out[i, j] += x * b[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_square(a: cython.const[cython.double][:, ::1], out: cython.double[:, ::1]) -> cython.void:
    """``out`` += A' A, the lower half; four rows of A at a time: a row of ``out`` is fetched a quarter as often."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    last: cython.Py_ssize_t = a.shape[0] - a.shape[0] % 4
    for i in range(a.shape[1]):
        for k in range(0, last, 4):
            w, x, y, z = a[k, i], a[k + 1, i], a[k + 2, i], a[k + 3, i]
            for j in range(i + 1):
                out[i, j] += w * a[k, j] + x * a[k + 1, j] + y * a[k + 2, j] + z * a[k + 3, j]
        for k in range(last, a.shape[0]):
            x = a[k, i]
            for j in range(i + 1):
                out[i, j] += x * a[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def inverse_root(root: cython.double[:, ::1], inverse: cython.double[:, ::1]) -> cython.bint:
    """L^-1 of a matrix L L', whose upper triangle is changed; False where it is not positive definite (Cholesky)."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    n: cython.Py_ssize_t = root.shape[0]
    for i in range(n):
        for j in range(n):
            inverse[i, j] = 0.0
        inverse[i, i] = 1.0
    for k in range(n):
        if not root[k, k] > 0.0:
            return False
        by = 1.0 / sqrt(root[k, k])
        for j in range(k, n):
            root[k, j] *= by
        for j in range(k + 1):
            inverse[k, j] *= by
        for i in range(k + 1, n):
            x = root[k, i]
            for j in range(i, n):
                root[i, j] -= x * root[k, j]
            for j in range(k + 1):
                inverse[i, j] -= x * inverse[k, j]
    return True
