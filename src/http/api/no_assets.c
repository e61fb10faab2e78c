/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a build without the dashboard. */
#include "http/api/assets.h"

const asset assets[] = {{.path = NULL}};
