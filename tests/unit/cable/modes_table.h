/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cables and their modes from two methods that share nothing: Galerkin in strains, and collocation
 * of the first-order system refined in extended precision (they agree to 1e-13 or better).
 */
#ifndef TESTS_CABLE_MODES_TABLE_H
#define TESTS_CABLE_MODES_TABLE_H

#include <strum/strum.h>

typedef struct {
    const char *name;
    strum_cable_params params;
    strum_cable_section sections[3];
    strum_cable_attachment attachments[8];
    strum_plane plane;
    int count, overdamped;
    double frequency[6], decay[6], root[4]; /* the last: overdamped */
} mode_case;

/* clang-format off */
static const mode_case mode_cases[] = {
    {"sagei-03-in",
     {.section_count = 1, .span = 400, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_CLAMPED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 400.6, .mass = 1.8, .weight = 17.65197, .axial_stiffness = 30000000, .bending_stiffness = 900, .bed_friction = NAN}},
     {{.kind = STRUM_CABLE_POINT_MASS}},
     STRUM_IN_PLANE, 6, 0,
     {1.985544390105726, 2.295136638918942, 3.174327321754999, 3.981733792267367, 5.00524381207392, 5.975642262654658},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"sagei-05-ou",
     {.section_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_CLAMPED, 0, NAN}, .end_2 = {STRUM_CABLE_CLAMPED, 0, NAN}},
     {{.length = 100.09, .mass = 2, .weight = 19.6133, .axial_stiffness = 1200000, .bending_stiffness = 40, .bed_friction = NAN}},
     {{.kind = STRUM_CABLE_POINT_MASS}},
     STRUM_OUT_OF_PLANE, 6, 0,
     {1.638591470461176, 3.273202259088991, 4.908787021680538, 6.544700034289093, 8.180843162439576, 9.817207523127568},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"mass-08-in",
     {.section_count = 1, .attachment_count = 2, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 105, .mass = 0.001, .weight = 0.00980665, .axial_stiffness = 1000000, .bed_friction = NAN}},
     {{STRUM_CABLE_POINT_MASS, 35, STRUM_CABLE_NORMAL, .mass = 50, .weight = 490.3325},
      {STRUM_CABLE_POINT_MASS, 70, STRUM_CABLE_NORMAL, .mass = 50, .weight = 490.3325}},
     STRUM_IN_PLANE, 6, 0,
     {1.38960324913958, 7.498394286125434, 23.90203365001764, 40.72050509773885, 98.7103010496174, 102.5243944013033},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"massei-03-in",
     {.section_count = 1, .attachment_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_CLAMPED, 0, NAN}, .end_2 = {STRUM_CABLE_CLAMPED, 0, NAN}},
     {{.length = 105, .mass = 2, .weight = 19.6133, .axial_stiffness = 1000000, .bending_stiffness = 150, .bed_friction = NAN}},
     {{STRUM_CABLE_POINT_MASS, 40, STRUM_CABLE_NORMAL, .mass = 30, .weight = 294.1995, .rotary_inertia = 9}},
     STRUM_IN_PLANE, 6, 0,
     {1.774955045963974, 2.772410326559141, 3.563853283077797, 4.820431611283009, 5.613110892170015, 6.2204377818303},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"buoy-05",
     {.section_count = 1, .attachment_count = 2, .span = 200, .rise = 120, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 260, .mass = 40, .weight = 300, .axial_stiffness = 60000000, .bed_friction = NAN}},
     {{STRUM_CABLE_POINT_MASS, 60, STRUM_CABLE_NORMAL, .mass = 1500, .weight = 12000, .added_mass = 600},
      {STRUM_CABLE_POINT_MASS, 180, STRUM_CABLE_NORMAL, .mass = 900, .weight = -14000, .added_mass = 1200}},
     STRUM_IN_PLANE, 6, 0,
     {0.4955969933584311, 1.023994729398901, 1.46791443691852, 1.519441178816759, 1.944648953375907, 2.706242396818079},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"buoy-08",
     {.section_count = 1, .attachment_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 105, .mass = 2, .weight = 19.6133, .axial_stiffness = 1000000, .bed_friction = NAN}},
     {{STRUM_CABLE_FORCE, 40, STRUM_CABLE_NORMAL, .force_x = -300}},
     STRUM_IN_PLANE, 6, 0,
     {1.726017371681158, 2.578770665024379, 3.627627066187333, 4.491746775486992, 5.467151250460478, 6.200707202767963},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"buoy-01",
     {.section_count = 3, .span = 170, .rise = 100, .spans = 1, .end_1 = {STRUM_CABLE_CLAMPED, 0, NAN}, .end_2 = {STRUM_CABLE_CLAMPED, 0, NAN}},
     {{.length = 120, .mass = 110, .weight = 650, .added_mass = 45, .axial_stiffness = 400000000, .bending_stiffness = 90000, .bed_friction = NAN},
      {.length = 60, .mass = 190, .weight = -500, .added_mass = 140, .axial_stiffness = 400000000, .bending_stiffness = 90000, .bed_friction = NAN},
      {.length = 90, .mass = 110, .weight = 650, .added_mass = 45, .axial_stiffness = 400000000, .bending_stiffness = 90000, .bed_friction = NAN}},
     {{.kind = STRUM_CABLE_POINT_MASS}},
     STRUM_IN_PLANE, 6, 0,
     {0.1744279884075472, 0.3106963822908405, 0.4184981482425124, 0.6130690370570567, 0.7986098765545067, 0.9269456369957518},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"tmd-3",
     {.section_count = 1, .attachment_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_CLAMPED, 0, NAN}, .end_2 = {STRUM_CABLE_CLAMPED, 0, NAN}},
     {{.length = 105, .mass = 2, .weight = 19.6133, .axial_stiffness = 1000000, .bending_stiffness = 100, .bed_friction = NAN}},
     {{STRUM_CABLE_ABSORBER, 30, STRUM_CABLE_VERTICAL, .mass = 20, .weight = 196.13299999999998, .stiffness = 90}},
     STRUM_IN_PLANE, 6, 0,
     {1.557059847074426, 2.272466431316143, 2.706590679487666, 3.826085953776263, 4.867883900426905, 5.686362249948207},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"rand-05",
     {.section_count = 1, .attachment_count = 1, .span = 63.1796, .rise = -32.1083, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_CLAMPED, 0, NAN}},
     {{.length = 70.92, .mass = 117.9, .weight = 1156.204035, .axial_stiffness = 4691000000, .bending_stiffness = 13350, .bed_friction = NAN}},
     {{STRUM_CABLE_POINT_MASS, 65.96, STRUM_CABLE_NORMAL, .mass = 699, .weight = 6854.848349999999}},
     STRUM_OUT_OF_PLANE, 6, 0,
     {2.997374596739477, 5.912683070280029, 8.658188295396643, 11.27653037805952, 14.00839212733658, 16.94102764688448},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"rand-25",
     {.section_count = 1, .attachment_count = 3, .span = 140.852, .rise = 202.962, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 283.8, .mass = 7.996, .weight = 78.4139734, .axial_stiffness = 362800000, .bed_friction = NAN}},
     {{STRUM_CABLE_SPRING, 42.57, STRUM_CABLE_ALL_IN_PLANE, .stiffness = 216},
      {STRUM_CABLE_INERTER, 59.6, STRUM_CABLE_HORIZONTAL, .inertance = 387},
      {STRUM_CABLE_INERTER, 153.3, STRUM_CABLE_NORMAL, .inertance = 59.9}},
     STRUM_IN_PLANE, 6, 0,
     {0.5454465637564713, 0.8759733654456634, 1.201647118053318, 1.596762487266159, 2.087201226822683, 2.409757898790153},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"cross-1",
     {.section_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 100.09, .mass = 2, .weight = 19.6133, .axial_stiffness = 5794818.127406926, .bed_friction = NAN}},
     {{.kind = STRUM_CABLE_POINT_MASS}},
     STRUM_IN_PLANE, 6, 0,
     {4.027181509463715, 4.027181509463707, 6.239337761543752, 8.074718225101375, 10.12813490260776, 12.11770029000421},
     {0, 0, 0, 0, 0, 0},
     {0}},
    {"lim-10",
     {.section_count = 1, .attachment_count = 1, .span = 100, .rise = 0, .spans = 1, .end_1 = {STRUM_CABLE_PINNED, 0, NAN}, .end_2 = {STRUM_CABLE_PINNED, 0, NAN}},
     {{.length = 105, .mass = 2, .weight = 19.6133, .axial_stiffness = 1000000, .bed_friction = NAN}},
     {{STRUM_CABLE_SPRING, 40, STRUM_CABLE_ALL_IN_PLANE, .stiffness = 10000000}},
     STRUM_IN_PLANE, 6, 0,
     {2.849509806666149, 4.09204825873057, 4.764694703817986, 5.819788277546007, 6.01137510106293, 6.685635831724669},
     {0, 0, 0, 0, 0, 0},
     {0}},
};
/* clang-format on */

#endif
