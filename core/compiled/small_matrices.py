"""Products and roots of matrices too small for a call of BLAS, for the other compiled modules.

Each writes into an array that its caller gives; ``small_matrices.pxd`` says which types they take.
"""

import cython
from cython import Py_ssize_t, double
from cython.cimports.libc.math import sqrt


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_product(a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]) -> cython.void:
    """
    Add A B to ``out``.

    Four rows of B at a time, so that a row of ``out`` is fetched a quarter as often; those that only zeros of A meet
    are left out, also where they are not finite (:func:`zero_times`).
    """
    columns: Py_ssize_t = b.shape[1]
    last: Py_ssize_t = a.shape[1] - a.shape[1] % 4
    for i in range(a.shape[0]):
        for k in range(0, last, 4):
            w, x, y, z = a[i, k], a[i, k + 1], a[i, k + 2], a[i, k + 3]
            if w != 0.0 or x != 0.0 or y != 0.0 or z != 0.0:
                for j in range(columns):
                    out[i, j] += w * b[k, j] + x * b[k + 1, j] + y * b[k + 2, j] + z * b[k + 3, j]
        for k in range(last, a.shape[1]):
            x = a[i, k]
            if x != 0.0:
                for j in range(columns):
                    out[i, j] += x * b[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_sparse_product(
    a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]
) -> cython.void:
    """Add A B to ``out``, of an A that is mostly zeros: the rows of B that the others meet, four at a time."""
    last: Py_ssize_t = a.shape[1] - 1
    for i in range(a.shape[0]):
        p: Py_ssize_t = 0
        q: Py_ssize_t = 0
        r: Py_ssize_t = 0
        s: Py_ssize_t = 0
        w: double = 0.0
        x: double = 0.0
        y: double = 0.0
        z: double = 0.0
        waiting: cython.int = 0
        for k in range(last + 1):
            if a[i, k] != 0.0:
                p, q, r, s = q, r, s, k
                w, x, y, z = x, y, z, a[i, k]
                waiting += 1
            if waiting == 4 or (waiting > 0 and k == last):
                for j in range(b.shape[1]):
                    out[i, j] += w * b[p, j] + x * b[q, j] + y * b[r, j] + z * b[s, j]
                w = x = y = z = 0.0
                waiting = 0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def zero_times(a: cython.const[double][:, ::1]) -> double:
    """0, or NaN where any number of A is not finite: what a product that leaves out zeros must begin with, so that
    nothing unknown is passed over. Only the lower half of what is square is looked at."""
    # Four sums: one would wait for itself.
    w: double = 0.0
    x: double = 0.0
    y: double = 0.0
    z: double = 0.0
    for i in range(a.shape[0]):
        j = 0
        while j + 3 <= i:
            w += 0.0 * a[i, j]
            x += 0.0 * a[i, j + 1]
            y += 0.0 * a[i, j + 2]
            z += 0.0 * a[i, j + 3]
            j += 4
        while j <= i:
            w += 0.0 * a[i, j]
            j += 1
    return w + x + y + z


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def inverse_root(root: double[:, ::1], inverse: double[:, ::1]) -> cython.bint:
    """L^-1 of a matrix L L', whose upper triangle is changed; False where it is not positive definite (Cholesky)."""
    n: Py_ssize_t = root.shape[0]
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
            if x != 0.0:
                for j in range(i, n):
                    root[i, j] -= x * root[k, j]
                for j in range(k + 1):
                    inverse[i, j] -= x * inverse[k, j]
    return True
