/* The paper's equations as printed, see literal.h. */
#include "shadow/literal.h"

#include <math.h>

double dpl_literal_p_occlusion(double mu1, double mu2, double d) {
    return (mu2 + d * d - 2.0 * mu1 * d) / (mu2 - mu1 * mu1);
}

double dpl_literal_s_msm(double mu1, double mu2, double d) {
    return fmax(0.0, 1.0 - dpl_literal_p_occlusion(mu1, mu2, d));
}

double dpl_literal_s_msm_final(double mu1, double mu2, double d) {
    return fmax(0.0, 1.0 - (mu2 + d * d - 2.0 * mu1 * d) / (mu2 - mu1));
}

double dpl_literal_alpha(double d, double k) {
    return (d + k) / d;
}

double dpl_literal_s_sdf(double beta, double d_occlusion, double cosine) {
    return exp(-beta * d_occlusion) * fmax(0.0, cosine);
}

double dpl_literal_s_sdf_final(double beta, double d_occlusion, double cosine) {
    return exp(-beta * d_occlusion * fmax(0.0, cosine));
}

double dpl_literal_summand(double mu1, double mu2, double d, double k, double beta, double d_occlusion,
                           double cosine) {
    double a = dpl_literal_alpha(d, k);
    return a * dpl_literal_s_msm_final(mu1, mu2, d) +
           (1.0 - a) * dpl_literal_s_sdf_final(beta, d_occlusion, cosine);
}
