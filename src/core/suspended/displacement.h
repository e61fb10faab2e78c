/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gale's equation (2.35) in weak form, for an inextensible cable without damping (or with
 * damping proportional to mass): Galerkin's method with clamped Legendre functions of the
 * tangential displacement u,
 *     INT (cosh u'' + sinh u' + sech u)(cosh w'' + sinh w' + sech w) dchi
 *         = omega^2 INT cosh (m_t u w + m_n cosh^2 u' w') dchi,
 * since the normal displacement is v = du/dalpha = cosh(chi) u'. Independent of the force form in unknown, equation and boundary conditions, and
 * half its size.
 */
#ifndef CORE_SUSPENDED_DISPLACEMENT_H
#define CORE_SUSPENDED_DISPLACEMENT_H

#include "core/suspended/roots.h"

/* The stiffness matrix is ill-conditioned on deep cables: up to here (xi 4) frequencies keep
 * 1e-15, up to the other (xi 100) the digits that are needed to confirm them. */
#define DISPLACEMENT_CHI_PRECISE 2.3
#define DISPLACEMENT_CHI_MAX     5.0

/* The lowest modes of a search in chi itself; of each symmetry class apart where `by_symmetry`
 * (level cables only). With `inner`, those of its smaller block too. */
strum_status displacement_roots(const root_search *q, bool by_symmetry, arena *a,
                                root_list *list, root_list *inner);

/* Size at which the first `count` modes should be right to 1e-12. */
int displacement_first_size(const strum_cable *cable, int count);
/* Functions more, with which they are right to about 1e-15. */
int displacement_margin(const strum_cable *cable, int size);

#endif
