"""Compiled loops over batches of ANCF cable elements, eqs. (8)-(11).

Symbols: r1 = r', r2 = r'' (by arc length); a = r1.r1, b = r2.r2, c = r1.r2.
Axial strain (9): eps = (a - 1)/2. Curvature (10) squared, by Lagrange's identity:

    kappa^2 = |r1 x r2|^2 / |r1|^6 = (a b - c^2)/a^3 =: phi(a, b, c),

which is smooth where kappa itself has a kink (kappa = 0). The energy density is (EA eps^2 + EJ phi)/2; its
derivatives by r1 and r2 follow from those of phi, and the chain rule with r1 = sum N'_k q_k, r2 = sum N''_k
q_k gives forces and stiffness.

Elements come in batches: `dofs` (n, 12) are indices into z in the order r_i, r_i', r_j, r_j'; `L`, `EA`, `EJ`
are (n,). `B1`, `B2` (n_points, 4) hold N' and N'' of an element of unit length, `w` (n_points,) the weights
on [-1, 1].
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.kernels.compile import compiled

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@compiled
def _slopes(
    z: FloatArray, dof: IntArray, L: float, B1: FloatArray, B2: FloatArray, r1: FloatArray, r2: FloatArray
) -> None:
    """Write r' and r'': columns 0, 2 of B1 scale with 1/L, of B2 with 1/L^2; 1, 3 with L times that."""
    for i in range(3):
        p_i, m_i, p_j, m_j = z[dof[i]], z[dof[3 + i]], z[dof[6 + i]], z[dof[9 + i]]
        r1[i] = (B1[0] * p_i + B1[2] * p_j) / L + B1[1] * m_i + B1[3] * m_j
        r2[i] = ((B2[0] * p_i + B2[2] * p_j) / L + B2[1] * m_i + B2[3] * m_j) / L


@compiled
def _dot(u: FloatArray, v: FloatArray) -> float:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


@compiled
def add_cable_forces(
    z: FloatArray,
    dofs: IntArray,
    L: FloatArray,
    EA: FloatArray,
    EJ: FloatArray,
    B1: FloatArray,
    B2: FloatArray,
    w: FloatArray,
    f: FloatArray,
) -> None:
    """Add dU/dq, the elastic forces -Q_q of eq. (13), of every element to f."""
    r1, r2 = np.empty(3), np.empty(3)
    for e in range(dofs.shape[0]):
        dof, length = dofs[e], L[e]
        for g in range(w.shape[0]):
            _slopes(z, dof, length, B1[g], B2[g], r1, r2)
            a, b, c = _dot(r1, r1), _dot(r2, r2), _dot(r1, r2)
            a3 = a * a * a
            phi_a = (3.0 * c * c - 2.0 * a * b) / (a3 * a)
            phi_b, phi_c = 1.0 / (a * a), -2.0 * c / a3
            scale = 0.5 * length * w[g]
            along = scale * (EA[e] * 0.5 * (a - 1.0) + EJ[e] * phi_a)
            cross = scale * 0.5 * EJ[e] * phi_c
            bend = scale * EJ[e] * phi_b
            for i in range(3):
                n_i = along * r1[i] + cross * r2[i]  # dU/dr1
                m_i = (bend * r2[i] + cross * r1[i]) / length  # dU/dr2, one power of 1/L taken out
                for k in range(4):
                    value = B1[g, k] * n_i + B2[g, k] * m_i
                    f[dof[3 * k + i]] += value / length if k % 2 == 0 else value


@compiled
def cable_stiffness(  # noqa: C901, nine loops are one formula
    z: FloatArray,
    dofs: IntArray,
    L: FloatArray,
    EA: FloatArray,
    EJ: FloatArray,
    B1: FloatArray,
    B2: FloatArray,
    w: FloatArray,
) -> FloatArray:
    """Return d2U/dq2, the exact tangent stiffness of every element, shape (n, 12, 12)."""
    n = dofs.shape[0]
    K = np.zeros((n, 12, 12))
    r1, r2, b1, b2 = np.empty(3), np.empty(3), np.empty(4), np.empty(4)
    H11, H12, H22 = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    for e in range(n):
        length = L[e]
        for g in range(w.shape[0]):
            _slopes(z, dofs[e], length, B1[g], B2[g], r1, r2)
            a, b, c = _dot(r1, r1), _dot(r2, r2), _dot(r1, r2)
            a2, a3, a4 = a * a, a * a * a, a * a * a * a
            phi_a, phi_b, phi_c = (3.0 * c * c - 2.0 * a * b) / a4, 1.0 / a2, -2.0 * c / a3
            phi_aa = (6.0 * a * b - 12.0 * c * c) / (a4 * a)
            phi_ab, phi_ac, phi_cc = -2.0 / a3, 6.0 * c / a4, -2.0 / a3
            axial, half = EA[e], 0.5 * EJ[e]
            diagonal_11 = axial * 0.5 * (a - 1.0) + half * 2.0 * phi_a
            for i in range(3):
                for j in range(3):
                    x11, x22, x12, x21 = r1[i] * r1[j], r2[i] * r2[j], r1[i] * r2[j], r2[i] * r1[j]
                    H11[i, j] = axial * x11 + half * (
                        4.0 * phi_aa * x11 + 2.0 * phi_ac * (x12 + x21) + phi_cc * x22
                    )
                    H12[i, j] = half * (4.0 * phi_ab * x12 + 2.0 * phi_ac * x11 + phi_cc * x21)
                    H22[i, j] = half * phi_cc * x11
                H11[i, i] += diagonal_11
                H12[i, i] += half * phi_c
                H22[i, i] += half * 2.0 * phi_b
            scale = 0.5 * length * w[g]
            for k in range(4):
                b1[k] = B1[g, k] / length if k % 2 == 0 else B1[g, k]
                b2[k] = B2[g, k] / (length * length) if k % 2 == 0 else B2[g, k] / length
            for k in range(4):
                for m in range(k, 4):
                    c11, c12 = scale * b1[k] * b1[m], scale * b1[k] * b2[m]
                    c21, c22 = scale * b2[k] * b1[m], scale * b2[k] * b2[m]
                    for i in range(3):
                        for j in range(3):
                            K[e, 3 * k + i, 3 * m + j] += (
                                c11 * H11[i, j] + c12 * H12[i, j] + c21 * H12[j, i] + c22 * H22[i, j]
                            )
        for row in range(12):
            for column in range(row):
                K[e, row, column] = K[e, column, row]
    return K


@compiled
def cable_energies(
    z: FloatArray,
    dofs: IntArray,
    L: FloatArray,
    EA: FloatArray,
    EJ: FloatArray,
    B1: FloatArray,
    B2: FloatArray,
    w: FloatArray,
) -> FloatArray:
    """Return the axial and the bending term of the strain energy (8) of every element [J], shape (n, 2)."""
    n = dofs.shape[0]
    energies = np.zeros((n, 2))
    r1, r2 = np.empty(3), np.empty(3)
    for e in range(n):
        for g in range(w.shape[0]):
            _slopes(z, dofs[e], L[e], B1[g], B2[g], r1, r2)
            a, b, c = _dot(r1, r1), _dot(r2, r2), _dot(r1, r2)
            scale = 0.25 * L[e] * w[g]
            energies[e, 0] += scale * EA[e] * 0.25 * (a - 1.0) ** 2
            energies[e, 1] += scale * EJ[e] * (a * b - c * c) / (a * a * a)
    return energies
