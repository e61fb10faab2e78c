/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What stands around the declarations of every public header: C linkage for C++ callers, and
 * default visibility. Everything else in libstrum is hidden, so that its private names cannot
 * meet those of a host program.
 */
#ifndef STRUM_EXPORT_H
#define STRUM_EXPORT_H

#ifdef __cplusplus
#define STRUM_LINKAGE_BEGIN extern "C" {
#define STRUM_LINKAGE_END   }
#else
#define STRUM_LINKAGE_BEGIN
#define STRUM_LINKAGE_END
#endif

#if defined(__GNUC__)
#define STRUM_VISIBLE_BEGIN _Pragma("GCC visibility push(default)")
#define STRUM_VISIBLE_END   _Pragma("GCC visibility pop")
#else
#define STRUM_VISIBLE_BEGIN
#define STRUM_VISIBLE_END
#endif

#define STRUM_BEGIN_DECLS STRUM_LINKAGE_BEGIN STRUM_VISIBLE_BEGIN
#define STRUM_END_DECLS   STRUM_VISIBLE_END STRUM_LINKAGE_END

#endif
