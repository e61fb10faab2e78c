/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of this folder share: the data and the quantities, a state of the cable, and what
 * it predicts. */
#ifndef CORE_IDENTIFY_PROBLEM_H
#define CORE_IDENTIFY_PROBLEM_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <strum/identify.h>

#include "core/numerics/status.h"
#include "core/numerics/work.h"

enum {
    TENSION = STRUM_IDENTIFY_TENSION,
    BENDING = STRUM_IDENTIFY_BENDING,
    FIXITY = STRUM_IDENTIFY_FIXITY,
    LENGTH = STRUM_IDENTIFY_LENGTH,
    MASS = STRUM_IDENTIFY_MASS,
    AXIAL = STRUM_IDENTIFY_AXIAL,
    DAMPING = STRUM_IDENTIFY_DAMPING,
    QUANTITIES = STRUM_IDENTIFY_QUANTITIES
};

#define UNKNOWNS_MAX STRUM_IDENTIFY_UNKNOWNS_MAX
/* Frequencies and damping ratios. */
#define DATA_MAX (2 * STRUM_IDENTIFY_FREQUENCIES_MAX)
/* And what is known of quantities beforehand. */
#define ROWS_MAX (DATA_MAX + UNKNOWNS_MAX)

typedef struct problem {
    size_t count;                                   /* of the data */
    size_t ratios_at;                               /* from here on they are damping ratios */
    double measured[DATA_MAX], deviation[DATA_MAX]; /* 1 where they are not known */
    int modes[DATA_MAX];
    bool weighted; /* deviations are known */
    bool skip[DATA_MAX];
    bool unknown[QUANTITIES];
    double value[QUANTITIES]; /* of those that are known */
    /* Known beforehand, with what standard deviation (of ln, of the fixity itself); 0: nothing. */
    double prior_value[QUANTITIES], prior[QUANTITIES];
    double added_mass, weight; /* weight across the chord */
    bool sag;
    strum_identify_end ends[2];
    const strum_identify_params *chain; /* NULL: a uniform cable */
    bool chain_scales;                  /* all frequencies go with the root of the tension */
    double chain_unit[DATA_MAX];        /* then: at 1 N */
    double damper_position;
    work *work;
} problem;

/* A state of the cable: all quantities, and u = sqrt(EI/T)/L, which stands for EI where that is
 * unknown. */
typedef struct state {
    double q[QUANTITIES];
    double u;
} state;

typedef struct prediction {
    double value;                       /* Hz, or a damping ratio */
    double by[QUANTITIES];              /* by ln of the quantity, by the fixity itself */
    double by_u;                        /* at held tension and length */
    double tension, bending, ends, sag; /* shares of the energy */
} prediction;

/* Index of quantity of coordinate `i`, in order; returns how many unknowns there are. */
size_t problem_unknowns(const problem *p, int which[UNKNOWNS_MAX]);
/* Data that are not skipped, and rows with what is known beforehand. */
size_t problem_data(const problem *p);
size_t problem_rows(const problem *p);
/* Completes EI or u from the other. */
void state_close(const problem *p, state *s);
/* (w L/T)^2/8, by which the sag lengthens the cable: Le = L (1 + that). */
double state_slack(const problem *p, const state *s);
/* lambda^2 of a state; 0 without sag. */
double state_lambda2(const problem *p, const state *s);
double state_mass(const problem *p, const state *s);

/* All predictions of a state. */
strum_status model_predict(const problem *p, const state *s, prediction *out);
strum_status model_predict_damper(const problem *p, const state *s, prediction *out);
strum_status model_predict_chain(const problem *p, const state *s, prediction *out);
/* The chain with all tensions times `factor`. */
strum_status model_chain(const strum_identify_params *c, double factor, strum_taut **chain,
                         strum_error *error);
/* Frequencies at 1 N, or whether they scale at all. */
strum_status model_prepare_chain(problem *p, strum_error *error);
/* Largest damping ratio of mode n of a string with a damper at `share` of its length, and
 * R = c/sqrt(T m) there; false where the branch cannot be followed. */
bool damper_best(int n, double share, double *ratio, double *r);

/* Chi^2 of predictions and of what is known beforehand. */
double state_chi2(const problem *p, const state *s, const prediction *out);

/* One fit from a start. */
typedef struct fit {
    state at;
    double chi2;
    size_t rows, unknowns;
    int which[UNKNOWNS_MAX];
    double residuals[ROWS_MAX];
    double jacobian[ROWS_MAX *
                    UNKNOWNS_MAX]; /* of data/deviation by ln quantity, rows to a column */
    prediction predictions[DATA_MAX], trial[DATA_MAX];
} fit;

/* Descends from f->at; the quantities that are known are set from `p`. */
strum_status fit_descend(const problem *p, fit *f);
/* The same to chi^2 and about seven digits of the state, without the derivatives by ln quantity. */
strum_status fit_chi2(const problem *p, fit *f);
/* A copy of what a fit begins from. */
void fit_start(fit *to, const fit *from);
/* All minima, the lowest first; `fits` has room for STRUM_IDENTIFY_SOLUTIONS_MAX. */
strum_status scan_minima(const problem *p, fit *fits, size_t *count, size_t *minima);

/* Interval of quantity `which` about a minimum, where chi^2 is at most `rise` above
 * `lowest`; NAN where there is no
 * end. */
strum_status profile_interval(const problem *p, const fit *from, int which, double lowest,
                              double rise, double start, double *low, double *high);

#endif
