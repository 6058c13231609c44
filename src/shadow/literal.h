/* The equations of the M.R.M.A. paper as printed, so that what they evaluate to can be tested rather than
 * told. They are for study: only the weight `literal` uses them. docs/algorithms/mrma.md walks from each to
 * the form that works. Names are the paper's; the numbers E1 … are those of that page. */
#ifndef DPL_SHADOW_LITERAL_H
#define DPL_SHADOW_LITERAL_H

/* E1: (mu2 + d^2 - 2 mu1 d) / (mu2 - mu1^2). Never below 1: it is 1 over Cantelli's bound. */
double dpl_literal_p_occlusion(double mu1, double mu2, double d);

/* E2: max(0, 1 - P). Always 0. */
double dpl_literal_s_msm(double mu1, double mu2, double d);

/* E4: the same with the square of the denominator dropped, as in the paper's last equation. At least 1 for
 * depths within 0 .. 1; depends on the unit of length. */
double dpl_literal_s_msm_final(double mu1, double mu2, double d);

/* E6: (d + k) / d. Above 1 for any k > 0. */
double dpl_literal_alpha(double d, double k);

/* E10, E11: exp(-beta d_occlusion) cos(theta), d_occlusion being the sum of the distances met on the way:
 * the more open the ray, the darker. */
double dpl_literal_s_sdf(double beta, double d_occlusion, double cosine);

/* E8: exp(-beta d_occlusion max(0, L.N)), the cosine inside the exponent: a surface facing away is lit. */
double dpl_literal_s_sdf_final(double beta, double d_occlusion, double cosine);

/* E7: one summand of the last equation. The sum over it has no end and no index inside: it diverges. */
double dpl_literal_summand(double mu1, double mu2, double d, double k, double beta, double d_occlusion,
                           double cosine);

#endif
