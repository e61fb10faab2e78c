/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From measured frequencies back to the cable: its tension, and with it bending stiffness, fixity
 * of the ends, length, mass, axial stiffness or a damper, with intervals and a word on what the
 * data cannot tell.
 *
 * Models: a tensioned beam between rotational springs, exactly; the same with the tension that a
 * shallow sag makes (Irvine and Caughey 1974); a taut chain (taut.h) whose tensions keep their
 * ratios; a string with a damper near one end. Everything is fitted by weighted least squares; a
 * scan of the few numbers that matter comes before, so that all minima are known; intervals are
 * those of the profile likelihood.
 *
 *     const double f[] = {0.43, 0.857, 1.286, 1.71};
 *     const int modes[] = {1, 2, 3, 4};
 *     strum_identify_params p = STRUM_IDENTIFY_PARAMS_INIT;
 *     strum_identify *found = NULL;
 *     strum_error error;
 *     p.frequencies = f, p.modes = modes, p.count = 4;
 *     p.quantities[STRUM_IDENTIFY_TENSION].unknown = true;
 *     p.quantities[STRUM_IDENTIFY_LENGTH].value = 177.168;
 *     p.quantities[STRUM_IDENTIFY_MASS].value = 51.6;
 *     if (strum_identify_solve(&p, NULL, &found, &error) == STRUM_OK)
 *         printf("%g N\n", strum_identify_estimate_of(found, STRUM_IDENTIFY_TENSION)->value);
 *     strum_identify_free(found);
 *
 * Units: SI, Hz. Ownership: params and what they point to are the caller's and need not outlive
 * the solve, but for the verification; a strum_identify is ended by strum_identify_free. All
 * functions are re-entrant; a solved object may be read by many threads.
 */
#ifndef STRUM_IDENTIFY_H
#define STRUM_IDENTIFY_H

#include <strum/taut.h>
#include <strum/types.h>

STRUM_BEGIN_DECLS

#define STRUM_IDENTIFY_FREQUENCIES_MAX 100
#define STRUM_IDENTIFY_MODE_MAX        1000
#define STRUM_IDENTIFY_UNKNOWNS_MAX    4
#define STRUM_IDENTIFY_SOLUTIONS_MAX   16
#define STRUM_IDENTIFY_READINGS_MAX    10
/* Assignments of mode numbers that one call tries. */
#define STRUM_IDENTIFY_ASSIGNMENTS_MAX 20000

typedef enum strum_identify_quantity {
    STRUM_IDENTIFY_TENSION, /* N: mean along the cable, where the tangent is parallel to the chord */
    STRUM_IDENTIFY_BENDING, /* EI, N m^2 */
    STRUM_IDENTIFY_FIXITY,  /* k/(k + 3 EI/L + sqrt(T EI)) of the ends of unknown stiffness */
    STRUM_IDENTIFY_LENGTH,  /* m */
    STRUM_IDENTIFY_MASS,    /* kg/m, without added mass */
    STRUM_IDENTIFY_AXIAL,   /* EA, N */
    STRUM_IDENTIFY_DAMPING, /* N s/m, of a damper */
    STRUM_IDENTIFY_QUANTITIES
} strum_identify_quantity;

/* Known exactly, unknown, or unknown and known with a standard deviation. */
typedef struct strum_identify_value {
    bool unknown;
    double value; /* not read of an unknown without standard deviation */
    /* Of an unknown: of ln value (of the fixity itself); 0: nothing is known beforehand. */
    double standard_deviation;
} strum_identify_value;

typedef enum strum_identify_end_kind {
    STRUM_IDENTIFY_PINNED,
    STRUM_IDENTIFY_CLAMPED,
    STRUM_IDENTIFY_FIXED_FIXITY,   /* `value`: fixity, 0 to 1 */
    STRUM_IDENTIFY_STIFFNESS,      /* `value`: N m/rad */
    STRUM_IDENTIFY_UNKNOWN_FIXITY, /* the quantity FIXITY, the same at both such ends */
} strum_identify_end_kind;

typedef struct strum_identify_end {
    strum_identify_end_kind kind;
    double value;
} strum_identify_end;

/* `argument` of an error of this header. */
typedef enum strum_identify_argument {
    STRUM_IDENTIFY_ARG_FREQUENCIES = 1, /* `index`: which */
    STRUM_IDENTIFY_ARG_STANDARD_DEVIATIONS,
    STRUM_IDENTIFY_ARG_MODES,
    STRUM_IDENTIFY_ARG_QUANTITIES, /* `index`: which */
    STRUM_IDENTIFY_ARG_ENDS,
    STRUM_IDENTIFY_ARG_UNKNOWNS, /* they cannot be told from these data */
    STRUM_IDENTIFY_ARG_DAMPING_RATIOS,
    STRUM_IDENTIFY_ARG_DAMPER_POSITION,
    STRUM_IDENTIFY_ARG_COMPONENTS,
    STRUM_IDENTIFY_ARG_ASSIGNMENT,
} strum_identify_argument;

typedef struct strum_identify_params {
    const double *frequencies;         /* Hz, ascending; NULL: damping ratios alone */
    const double *standard_deviations; /* Hz; NULL: equal and unknown */
    /* Their numbers, ascending; NULL: all increasing ones are tried whose first is at most
     * first_mode_max, and with at most missing_max modes between the first and the last. */
    const int *modes;
    size_t count; /* 1 .. STRUM_IDENTIFY_FREQUENCIES_MAX */
    int first_mode_max, missing_max;
    strum_identify_value quantities[STRUM_IDENTIFY_QUANTITIES];
    double added_mass;  /* kg/m, >= 0 */
    bool sag;           /* the sag acts: in plane */
    double weight;      /* N/m, >= 0; with sag */
    double inclination; /* rad, of the chord; with sag */
    strum_identify_end ends[2];
    /* In place of length and mass; their tensions are those at `reference_tension` and all
     * scale with the tension that is sought. NULL: a uniform cable. */
    const strum_taut_component *components;
    size_t component_count;
    strum_taut_end left, right;
    double reference_tension;
    const double *damping_ratios, *damping_standard_deviations; /* `count` of each, or NULL */
    double damper_position;                                     /* m from an end */
    double confidence;                                          /* 0.5 .. 0.9999 */
    bool exclude_outlier; /* the frequency that disagrees most, where one does */
} strum_identify_params;

#define STRUM_IDENTIFY_PARAMS_INIT                                                             \
    {                                                                                          \
        .first_mode_max = 6, .missing_max = 4, .confidence = 0.95                              \
    }

typedef struct strum_identify strum_identify;

/* STRUM_ERR_RANGE: a parameter; STRUM_ERR_IMPOSSIBLE: no such cable (a frequency below what the
 * bending alone gives, a damping ratio that no damper reaches), or unknowns that these data cannot
 * tell apart: the reason names their combination. */
strum_status strum_identify_solve(const strum_identify_params *params,
                                  const strum_options *options, strum_identify **found,
                                  strum_error *error);
/* Microseconds that a solve takes, roughly. */
double strum_identify_work(const strum_identify_params *params);
void strum_identify_free(strum_identify *found);

/* ---- what was found ---- */

typedef struct strum_identify_estimate {
    bool unknown; /* of the request; else `value` alone has a meaning */
    double value;
    double standard_error; /* linearised; NAN where there is none */
    /* Ends of the profile interval; NAN where there are too few data, or no end on that side. */
    double low, high;
    bool
        determined; /* by the data: the interval is narrower than a factor e^2 (a fixity's is not
                        all of [0, 1]), and one solution alone fits */
} strum_identify_estimate;

const strum_identify_estimate *strum_identify_estimate_of(const strum_identify *found,
                                                          strum_identify_quantity quantity);

typedef struct strum_identify_mode {
    int mode;
    bool excluded;
    double measured, computed, residual; /* Hz; of damping ratios where these alone are given */
    double measured_ratio, computed_ratio; /* damping; NAN without */
    double
        studentized; /* by the given deviation, else by that of the others; NAN where there is none */
    double leverage;
    double tension_without; /* the fit without it, N; NAN where there is none */
    double string_rule;     /* 4 m L^2 f^2/n^2, N; NAN for chains */
    double share_tension, share_bending, share_ends,
        share_sag; /* of the strain energy; NAN for chains */
} strum_identify_mode;

size_t strum_identify_count(const strum_identify *found);
strum_status strum_identify_get(const strum_identify *found, size_t i,
                                strum_identify_mode *mode);

typedef struct strum_identify_summary {
    double chi_squared; /* of residuals over standard deviations, or in Hz^2 */
    int degrees_of_freedom;
    double p_value; /* NAN without standard deviations or degrees of freedom */
    double
        residual_deviation; /* Hz; NAN with standard deviations or without degrees of freedom */
    size_t local_minima;
    size_t unknowns;
    strum_identify_quantity which[STRUM_IDENTIFY_UNKNOWNS_MAX]; /* order of what follows */
    double singular_values
        [STRUM_IDENTIFY_UNKNOWNS_MAX];           /* of d f/sigma / d ln quantity (fixity) */
    double weakest[STRUM_IDENTIFY_UNKNOWNS_MAX]; /* direction of the smallest */
    double correlation[STRUM_IDENTIFY_UNKNOWNS_MAX][STRUM_IDENTIFY_UNKNOWNS_MAX];
    double tension_if_pinned, tension_if_clamped; /* NAN where nothing depends on it */
    double xi, lambda_squared, sag_to_span;       /* NAN where they have no meaning */
    int better_shift; /* the same numbers shifted by this fit far better; 0: none */
    double shift_tension, shift_ratio; /* tension then, chi^2 over that of the shift */
    size_t outlier;               /* index of the frequency that disagrees; STRUM_NO_INDEX */
    double outlier_tension;       /* without it */
    double tension_at_no_bending; /* with EI 0, where EI is not determined; NAN */
} strum_identify_summary;

const strum_identify_summary *strum_identify_summary_of(const strum_identify *found);

/* A minimum that fits as well as the best, within the confidence; the first is the best. */
typedef struct strum_identify_solution {
    double values[STRUM_IDENTIFY_QUANTITIES];
    double chi_squared, lambda_squared;
    bool
        below_optimum; /* of a damper: its damping is below the one that damps the first of the modes best */
} strum_identify_solution;

size_t strum_identify_solutions(const strum_identify *found,
                                const strum_identify_solution **solutions);

/* A reading of unlabelled frequencies. criterion = chi^2 + 2 ln 9 for each mode below the highest
 * that is missing: a mode is missed with a probability of 0.1. The first is the one that was taken. */
typedef struct strum_identify_reading {
    int modes[STRUM_IDENTIFY_FREQUENCIES_MAX];
    double criterion, chi_squared, tension;
} strum_identify_reading;

/* 0 where the numbers were given. `ambiguous`: another reading is within 2 ln 20;
 * `by_price`: the data alone (chi^2 within 4) do not tell. `assumed_deviation`: Hz, NAN where they
 * were given. */
size_t strum_identify_readings(const strum_identify *found,
                               const strum_identify_reading **readings, bool *ambiguous,
                               bool *by_price, double *assumed_deviation);

/* ---- beside it ---- */

/*
 * The formulas that practice compares with, from the frequencies of a uniform cable: the string
 * rule 4 m L^2 f^2/n^2 and that of the mean of f/n; the regression (f/n)^2 = A + B n^2, which is
 * exact between pinned ends; H. Zui, T. Shinke and Y. Namita (1996), W. X. Ren, G. Chen and W. H.
 * Hu (2005), and A. B. Mehrabi and H. Tabatabai (1998). Their constants were checked against the
 * exact clamped beam, not against the papers. N; NAN where a formula has no such frequency or no
 * solution. A branch is the one in whose range its own answer lies; `_outside` where none is.
 */
typedef struct strum_identify_comparison {
    double string_rule[STRUM_IDENTIFY_FREQUENCIES_MAX], string_mean;
    double regression, regression_bending;        /* N, N m^2; of two or more frequencies */
    double zui_1, zui_2;                          /* of modes 1 and 2 */
    double zui_n[STRUM_IDENTIFY_FREQUENCIES_MAX]; /* of modes from 3 on */
    double ren;                                   /* of mode 1 */
    double mehrabi_tabatabai[STRUM_IDENTIFY_FREQUENCIES_MAX];
    const char *zui_1_branch, *zui_2_branch, *ren_branch; /* static text */
    bool zui_1_outside, zui_2_outside, ren_outside;
    bool zui_n_outside[STRUM_IDENTIFY_FREQUENCIES_MAX];
    bool mehrabi_tabatabai_outside[STRUM_IDENTIFY_FREQUENCIES_MAX];
} strum_identify_comparison;

/* With the length, mass, bending and axial stiffness that were known or found. STRUM_ERR_METHOD of
 * a chain, or without frequencies. */
strum_status strum_identify_compare(const strum_identify *found,
                                    strum_identify_comparison *comparison);

/* The frequencies computed at the answer, once more by finite elements (of a uniform cable), by an
 * assembled stiffness (of a chain), by transfer matrices (of a damper); `params` as solved.
 * STRUM_ERR_METHOD for modes above 60, which need too large a problem. */
strum_status strum_identify_verify(const strum_identify *found,
                                   const strum_identify_params *params,
                                   const strum_options *options,
                                   strum_verification *verification, strum_error *error);

STRUM_END_DECLS
#endif
