"""Noise of sensors, as SDFormat describes it."""

from __future__ import annotations

from collections.abc import Mapping

from checker.base.record import Record
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element, Tagged


class Noise(Tagged, Record, eq=False):
    """A `<noise>`; all figures in the unit of the value that it is added to.

    Attributes:
        type: `none`, `gaussian` or `gaussian_quantized`.
        mean: The mean of the white noise.
        stddev: The standard deviation of the white noise.
        bias_mean: The mean of the constant bias.
        bias_stddev: The standard deviation of the constant bias.
        dynamic_bias_stddev: The standard deviation of the bias that drifts.
        dynamic_bias_correlation_time: Seconds in which it wanders.
        precision: Step of the quantization.
        element: The `<noise>`.
    """

    type: Located[str]
    mean: Located[float]
    stddev: Located[float]
    bias_mean: Located[float]
    bias_stddev: Located[float]
    dynamic_bias_stddev: Located[float]
    dynamic_bias_correlation_time: Located[float]
    precision: Located[float]
    element: Element

    @property
    def figures(self) -> Mapping[str, Located[float]]:
        """Its figures by their tags."""
        return {
            "mean": self.mean,
            "stddev": self.stddev,
            "bias_mean": self.bias_mean,
            "bias_stddev": self.bias_stddev,
            "dynamic_bias_stddev": self.dynamic_bias_stddev,
            "dynamic_bias_correlation_time": self.dynamic_bias_correlation_time,
            "precision": self.precision,
        }


def read_noise(holder: Element | None) -> Noise | None:
    """Read the `<noise>` of an element; None if there is none."""
    element = holder.child("noise") if holder is not None else None
    if element is None:
        return None
    values = ValueReader()
    # A child up to SDF 1.6's sensors of pictures and ranges, an attribute where axes have noise.
    type_ = element.attribute("type") or values.text(element, "type", "none")
    return Noise(
        type_,
        values.number(element, "mean", 0.0),
        values.number(element, "stddev", 0.0),
        values.number(element, "bias_mean", 0.0),
        values.number(element, "bias_stddev", 0.0),
        values.number(element, "dynamic_bias_stddev", 0.0),
        values.number(element, "dynamic_bias_correlation_time", 0.0),
        values.number(element, "precision", 0.0),
        element,
    )
