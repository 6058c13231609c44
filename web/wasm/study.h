/* The ARC paper's 50 scenes: the very code of `dapple study`, a scene at a time. Called by
 * web/module/core.js. */
#ifndef DPL_WEB_STUDY_H
#define DPL_WEB_STUDY_H

#include "session.h"

/* Begins a study of one seed; ends the one before. Sizes and counts as the command takes them; `truth` pixels
 * per scene. 0 with a message (host.h) when it fails; so do the others. */
int32_t dpl_web_study_open(dpl_web_session *session, uint64_t seed, int32_t size, int32_t scenes,
                           int32_t truth);

/* Runs the next scene. */
int32_t dpl_web_study_next(dpl_web_session *session);

/* Ends the study and frees what it holds. */
void dpl_web_study_close(dpl_web_session *session);

/* Hands the numbers of the scene that was run last to the host, by name. */
void dpl_web_study_read(dpl_web_session *session);

/* Over the scenes that were run: r, low, high, p and count of a signal (dpl_study_signal) with the quality of
 * L2 in a profile (dpl_study_profile). `quality`: 0 psnr_display, 1 psnr_linear. */
int32_t dpl_web_study_correlate(dpl_web_session *session, int32_t profile, int32_t signal, int32_t quality,
                                double values[5]);

/* Names of signals as dapple study spells them; NULL behind the last. */
const char *dpl_web_study_signal(int32_t signal);

#endif
