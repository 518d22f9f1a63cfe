"""What the FMI standard (fmi-standard.org, versions 2.0.5 and 3.0.2) asks of a unit for co-simulation, as far as ours
could break it."""
import re

# Every function, by section: a unit exports all of them, whatever it is for.
TYPES3 = "Float32 Float64 Int8 UInt8 Int16 UInt16 Int32 UInt32 Int64 UInt64 Boolean String Binary Clock".split()
FUNCTIONS = {
    3: {"fmi3" + name for name in """
        GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution FreeInstance
        EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset
        GetNumberOfVariableDependencies GetVariableDependencies
        GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState
        GetDirectionalDerivative GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode
        GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction
        SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates
        EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives
        GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates
        EnterStepMode GetOutputDerivatives DoStep ActivateModelPartition""".split()}
       | {f"fmi3{way}{kind}" for way in ("Get", "Set") for kind in TYPES3},
    2: {"fmi2" + name for name in """
        GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment EnterInitializationMode
        ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString
        GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate GetDirectionalDerivative
        EnterEventMode NewDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetDerivatives
        GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates SetRealInputDerivatives GetRealOutputDerivatives
        DoStep CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus""".split()},
}
assert len(FUNCTIONS[3]) == 75 and len(FUNCTIONS[2]) == 44

# Element: (attributes it must have, others it may have, children in this order). Of the schemas, what a unit of ours
# can contain.
UNITS = {
    "UnitDefinitions": ("", "", "Unit"), "Unit": ("name", "", "BaseUnit DisplayUnit"),
    "BaseUnit": ("", "kg m s A K mol cd rad factor offset", ""),
    "LogCategories": ("", "", "Category"), "Category": ("name", "description", ""),
    "DefaultExperiment": ("", "startTime stopTime tolerance stepSize", "")}
SCHEMAS = {
    3: UNITS | {
        "fmiModelDescription": ("fmiVersion modelName instantiationToken",
                                "description author version copyright license generationTool "
                                "generationDateAndTime variableNamingConvention",
                                "CoSimulation UnitDefinitions LogCategories DefaultExperiment ModelVariables "
                                "ModelStructure"),
        "CoSimulation": ("modelIdentifier",
                         "needsExecutionTool canBeInstantiatedOnlyOncePerProcess canGetAndSetFMUState "
                         "canSerializeFMUState providesDirectionalDerivatives providesAdjointDerivatives "
                         "providesPerElementDependencies "
                         "canHandleVariableCommunicationStepSize fixedInternalStepSize maxOutputDerivativeOrder "
                         "recommendedIntermediateInputSmoothness providesIntermediateUpdate mightReturnEarlyFromDoStep "
                         "canReturnEarlyAfterIntermediateUpdate hasEventMode providesEvaluateDiscreteStates", ""),
        "ModelVariables": ("", "", "Float64"),
        "Float64": ("name valueReference",
                    "description causality variability initial start min max nominal unit displayUnit "
                    "declaredType derivative reinit clocks previous intermediateUpdate "
                    "canHandleMultipleSetPerTimeInstant", ""),
        "ModelStructure": ("", "", "Output InitialUnknown"),
        "Output": ("valueReference", "dependencies dependenciesKind", ""),
        "InitialUnknown": ("valueReference", "dependencies dependenciesKind", "")},
    2: UNITS | {
        "fmiModelDescription": ("fmiVersion modelName guid",
                                "description author version copyright license generationTool "
                                "generationDateAndTime variableNamingConvention numberOfEventIndicators",
                                "CoSimulation UnitDefinitions LogCategories DefaultExperiment ModelVariables "
                                "ModelStructure"),
        "CoSimulation": ("modelIdentifier",
                         "needsExecutionTool canHandleVariableCommunicationStepSize canInterpolateInputs "
                         "maxOutputDerivativeOrder canRunAsynchronuously canBeInstantiatedOnlyOncePerProcess "
                         "canNotUseMemoryManagementFunctions canGetAndSetFMUstate canSerializeFMUstate "
                         "providesDirectionalDerivative",
                         "SourceFiles"),
        "SourceFiles": ("", "", "File"), "File": ("name", "", ""),
        "ModelVariables": ("", "", "ScalarVariable"),
        "ScalarVariable": ("name valueReference",
                           "description causality variability initial canHandleMultipleSetPerTimeInstant", "Real"),
        "Real": ("", "declaredType quantity unit displayUnit relativeQuantity min max nominal unbounded start "
                 "derivative reinit", ""),
        "ModelStructure": ("", "", "Outputs Derivatives DiscreteStates InitialUnknowns"),
        "Outputs": ("", "", "Unknown"), "InitialUnknowns": ("", "", "Unknown"),
        "Unknown": ("index", "dependencies dependenciesKind", "")},
}

# Causality and variability that go together (FMI 3.0 table 18, FMI 2.0 section 2.2.7), with what `initial` may say and
# whether `start` stands there.
COMBINATIONS = {("independent", "continuous"): ({None}, False), ("input", "continuous"): ({None}, True),
                ("output", "discrete"): ({"calculated"}, False), ("parameter", "tunable"): ({"exact"}, True)}


def breaches(element, schema):
    """What of an element and all below it its schema does not allow."""
    found = []
    must, may, children = (part.split() for part in schema[element.tag])
    found += [f"{element.tag} lacks {name}" for name in must if name not in element.keys()]
    found += [f"{element.tag} has {name}" for name in element.keys() if name not in must + may]
    tags = [child.tag for child in element]
    if any(tag not in children for tag in tags) or tags != sorted(tags, key=children.index):
        return found + [f"{element.tag} holds {tags}"]
    for child in element:
        found += breaches(child, schema)
    return found


def description_breaches(root):
    """What of a modelDescription.xml breaks the standard."""
    version = int(float(root.get("fmiVersion")))
    found = breaches(root, SCHEMAS[version])
    if not re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", root.find("CoSimulation").get("modelIdentifier")):
        found.append("the model identifier begins names in C")
    units = [unit.get("name") for unit in root.iter("Unit")]
    found += [f"unit {name} twice" for name in set(units) if units.count(name) > 1]
    variables = list(root.find("ModelVariables"))
    names = [v.get("name") for v in variables]
    references = [v.get("valueReference") for v in variables]
    if len(set(names)) < len(names) or len(set(references)) < len(references):
        found.append("two variables are alike")
    outputs = []
    for place, v in enumerate(variables):
        kind = (v.get("causality"), v.get("variability"))
        value = v.find("Real") if version == 2 else v
        if kind not in COMBINATIONS:
            found.append(f"{v.get('name')} is {kind}")
            continue
        initial, has_start = COMBINATIONS[kind]
        if v.get("initial") not in initial or (value.get("start") is not None) != has_start:
            found.append(f"initial or start of {v.get('name')}")
        if value.get("unit") not in units:
            found.append(f"unit of {v.get('name')}")
        if value.get("min") is not None and not float(value.get("min")) <= float(value.get("start")) <= float(
            value.get("max")):
            found.append(f"start of {v.get('name')} is beyond its range")
        if kind[0] == "output":
            outputs.append(v.get("valueReference") if version == 3 else str(place + 1))
    if sum(v.get("causality") == "independent" for v in variables) != 1:
        found.append("time is not there once")
    structure = root.find("ModelStructure")
    lists = ([e.get("valueReference") for e in structure.iter(tag)]
             for tag in ("Output", "InitialUnknown")) if version == 3 else (
        [e.get("index") for e in structure.iterfind(f"{tag}/Unknown")] for tag in ("Outputs", "InitialUnknowns"))
    found += ["the model structure lists other outputs" for listed in lists if listed != outputs]
    return found
