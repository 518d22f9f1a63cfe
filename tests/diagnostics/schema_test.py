"""The JSON Schemas beside the format's references, against every file of the project and every bad case.

A schema sees the shape of a file, not what it means: BEYOND_THE_SCHEMAS lists the bad cases that have a good shape, and
the test fails as well when one of those is refused, so that the list stays true.
"""
import json
import pathlib
import re
import sys
import unittest

try:
    import jsonschema
except ImportError:
    sys.exit("the schema test needs jsonschema (Debian: python3-jsonschema)")

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "tests/diagnostics/cases"

BEYOND_THE_SCHEMAS = {
    # devices: values and units
    "devices/band_above_half_the_rate", "devices/band_reversed", "devices/coil_lag_below_the_band",
    "devices/damping_at_the_tool", "devices/jitter_of_a_period", "devices/zero_told_once",
    "devices/limit_as_a_current", "devices/brake_safe_damping_too_large", "devices/brake_unit_of_the_other_motion",
    "devices/estimator_cutoff_above_nyquist", "devices/estimator_without_encoder_step",
    "devices/rate_is_a_period", "devices/units_run_together", "devices/write_after_a_period",
    "devices/write_delay_reversed",
    # two axes: geometry and physics
    "axes_field_gives_power", "axes_grid_falls", "axes_grid_uneven", "axes_map_radius_of_zero", "axes_port_twice",
    "axes_tunable",
    "devices/axes_arm_out_of_reach", "devices/axes_arm_singular", "devices/axes_brakes_parallel",
    "devices/axes_inertia_below_zero", "devices/axes_inertia_not_symmetric", "devices/axes_jitter_of_a_period",
    "devices/axes_link_masses_of_cartesian", "devices/axes_motion_of_serial", "devices/axes_workspace_beyond_encoder",
    # several ports: what is true of all of them
    "ports_of_one_name", "ports_with_a_tunable", "ports_with_bad_parameters",
    # names
    "ends_are_called_tip_and_gnd", "ground_is_called_gnd", "name_is_a_keyword", "name_of_a_member", "name_taken",
    "node_differs_by_case",
    # JSON that Python reads all the same
    "key_given_three_times", "key_given_twice", "levels_too_many", "number_too_large",
    # parameters
    "expression_of_an_element", "unit_run_together_with_its_exponent", "parameter_negative",
    "parameter_of_two_meanings", "parameter_of_wrong_unit", "parameter_unknown",
    "parameter_unused", "tunable_contact", "tunable_out_of_range", "tunable_range_negative",
    "tunable_range_of_another_unit", "tunable_range_reversed",
    # expressions, springpots and Prony series: what they mean
    "expression_below_double", "expression_beyond_double", "expression_for_rotation", "expression_negative",
    "expression_of_later_parameter", "expression_of_tunable", "expression_of_unknown_function",
    "expression_of_unknown_parameter", "expression_of_wrong_unit", "expression_that_adds_lengths_to_stiffnesses",
    "expression_that_divides_by_zero", "expression_that_ends_early", "expression_too_deep",
    "expression_with_exponential_of_length", "expression_with_logarithm_of_zero", "expression_with_open_bracket",
    "expression_with_root_of_negative", "expression_with_root_without_unit", "expression_with_stray_bracket",
    "expression_without_product_sign", "prony_time_of_zero", "prony_weights_above_one",
    "static_power_below_one", "static_power_with_unit", "static_force_of_zero", "static_rate_negative",
    "static_table_starts_elsewhere",
    "static_table_goes_back", "static_table_softens", "static_at_tunable",
    "springpot_band_at_zero", "springpot_band_reversed", "springpot_band_too_wide", "springpot_beyond_a_double",
    "springpot_beyond_its_band", "springpot_error_too_small",
    "springpot_exponent_above_one", "springpot_exponent_of_damper", "springpot_exponent_of_spring", "springpot_of_zero",
    "springpot_time_of_zero", "springpot_tunable", "springpot_without_band",
    # values and units
    "element_of_value_zero", "quantity_not_finite", "quantity_without_number", "quantity_too_large",
    "quantity_too_small",
    "unit_behind_an_escape", "unit_in_small_letters", "unit_malformed", "unit_of_another_element",
    "unit_of_the_other_motion",
    "unit_read_in_two_ways", "unit_run_together", "unit_unknown", "unit_without_a_name", "unit_with_percent",
    "unit_without_radian",
    "valid_range_of_wrong_unit", "valid_range_reversed", "yield_zero",
    # connections
    "ends_of_an_element_equal", "ground_unused", "loop_beside_the_path", "node_used_once",
    "part_connected_to_nothing", "slips_from_tool_to_ground", "slips_from_tool_to_ground_in_a_graph",
    "tool_and_ground_not_connected", "tool_unused",
}


def validator(path):
    schema = json.loads((ROOT / path).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


NETWORK = validator("networks/network.schema.json")
DEVICE = validator("runtime/devices/device.schema.json")


def load(path):
    """The file's value, or nothing where it is not JSON, which a schema never sees."""
    try:
        return json.loads(path.read_bytes().decode("utf-8"), parse_constant=float)
    except ValueError:
        return None


def keys_in(schema):
    """Every key that a schema gives a meaning to."""
    if isinstance(schema, list):
        return set().union(*map(keys_in, schema))
    if not isinstance(schema, dict):
        return set()
    own = set(schema.get("properties", {}))
    return own.union(*map(keys_in, schema.values()))


def examples_in(readme):
    return [json.loads(block) for block in re.findall(r"```json\n(.*?)```", readme.read_text(encoding="utf-8"), re.S)]


class SchemaTest(unittest.TestCase):
    def expect_good(self, schema, value, where):
        errors = [error.message for error in schema.iter_errors(value)]
        self.assertEqual(errors, [], where)

    # If this fails, editors mark a file of the project that the compiler takes.
    def test_files_of_the_project_are_good(self):
        networks = [path for path in (ROOT / "networks").rglob("*.json") if not path.name.endswith(".schema.json")]
        devices = [path for path in (ROOT / "runtime/devices").glob("*.json") if not path.name.endswith(".schema.json")]
        devices += (ROOT / "examples").glob("*/device.json")
        networks += (path for path in (ROOT / "examples").glob("*/*.json") if path not in devices)
        self.assertTrue(networks)
        for path in networks:
            self.expect_good(NETWORK, load(path), path)
        for path in devices:
            self.expect_good(DEVICE, load(path), path)

    # If this fails, the references show what editors refuse.
    def test_examples_of_the_references_are_good(self):
        for schema, readme in ((NETWORK, "networks/README.md"), (DEVICE, "runtime/devices/README.md")):
            examples = examples_in(ROOT / readme)
            self.assertTrue(examples)
            for example in examples:
                self.expect_good(schema, example, readme)

    # If this fails, editors offer a key that the reference does not explain.
    def test_every_key_is_in_the_reference(self):
        for schema, readme in ((NETWORK, "networks/README.md"), (DEVICE, "runtime/devices/README.md")):
            explained = set(re.findall(r"`\"?(\w+)\"?`", (ROOT / readme).read_text(encoding="utf-8")))
            self.assertEqual(keys_in(schema.schema) - explained, set(), readme)

    # If this fails, editors are silent about a mistake of shape, or a case is no longer what its name says.
    def test_bad_cases_are_refused(self):
        for path in sorted(CASES.rglob("*.json")):
            value = load(path)
            if value is None:
                continue
            name = str(path.relative_to(CASES).with_suffix(""))
            schema = DEVICE if path.parent.name == "devices" else NETWORK
            with self.subTest(name):
                self.assertEqual(schema.is_valid(value), name in BEYOND_THE_SCHEMAS)


if __name__ == "__main__":
    unittest.main()
