"""Formulas alone: the paper's laws, this library's, and other authors'."""

from hodograph.laws.others import d_norm_chudinov, d_norm_first_order, d_norm_low, d_norm_upright
from hodograph.laws.own import (
    LAW_ALL,
    LAW_ANGLE,
    LAW_M,
    LAW_V,
    alpha_max_law,
    d_norm_law,
    d_norm_law_all,
    first_order,
)
from hodograph.laws.vial import (
    ALPHA_MAX_H,
    ALPHA_MAX_K,
    ALPHA_MAX_M,
    TABLE_1_K,
    TABLE_1_M,
    PearsonFit,
    PolynomialFit,
    alpha_max_vial,
    fit_pearson,
    fit_polynomial,
    pearson_vii,
    table_1,
)

__all__ = [
    "ALPHA_MAX_H", "ALPHA_MAX_K", "ALPHA_MAX_M", "LAW_ALL", "LAW_ANGLE", "LAW_M", "LAW_V",
    "TABLE_1_K", "TABLE_1_M", "PearsonFit", "PolynomialFit", "alpha_max_law", "alpha_max_vial",
    "d_norm_chudinov", "d_norm_first_order", "d_norm_law", "d_norm_law_all", "d_norm_low",
    "d_norm_upright", "first_order", "fit_pearson", "fit_polynomial", "pearson_vii", "table_1",
]  # fmt: skip
