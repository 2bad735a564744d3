"""What course systems document of their files, written down from their documentation; and a check
of XML by such a table.
"""

from collections.abc import Iterator
from xml.etree.ElementTree import Element

NUMBER, TEXT = {"type": "number"}, {"type": "string"}
SHOWN = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
FORMAT = {"enum": ["text", "html", "simple_format", "md", "ansi"]}

GRADESCOPE = {  # "Autograder specifications", "Output format"
    "type": "object",
    "additionalProperties": False,
    "anyOf": [{"required": ["score"]}, {"required": ["tests"]}],
    "properties": {
        "score": NUMBER,
        "execution_time": NUMBER,
        "output": TEXT,
        "output_format": FORMAT,
        "test_output_format": FORMAT,
        "test_name_format": FORMAT,
        "visibility": SHOWN,
        "stdout_visibility": SHOWN,
        "extra_data": {"type": "object"},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "score": NUMBER | {"minimum": 0},
                    "max_score": NUMBER | {"minimum": 0},
                    "status": {"enum": ["passed", "failed"]},
                    "name": TEXT,
                    "name_format": FORMAT,
                    "number": TEXT,
                    "output": TEXT,
                    "output_format": FORMAT,
                    "tags": {"type": "array", "items": TEXT},
                    "visibility": SHOWN,
                    "extra_data": {"type": "object"},
                },
            },
        },
        "leaderboard": {"type": "array"},
    },
}

IMAGES = {
    "type": "array",
    "items": {
        "type": "object",
        "required": ["url"],
        "additionalProperties": False,
        "properties": {
            "label": TEXT,
            "url": {"type": "string", "pattern": "^data:image/(png|jpeg|gif);base64,[\\w+/]+=*$"},
        },
    },
}

PRAIRIELEARN = {  # "External grading", "Grading results"
    "type": "object",
    "if": {"properties": {"gradable": {"const": False}}, "required": ["gradable"]},
    "else": {"required": ["score"]},
    "properties": {
        "gradable": {"type": "boolean"},
        "score": {"type": "number", "minimum": 0, "maximum": 1},
        "message": TEXT,
        "output": TEXT,
        "format_errors": {"anyOf": [TEXT, {"type": "array", "items": TEXT}]},
        "images": IMAGES,
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "name": TEXT,
                    "description": TEXT,
                    "points": NUMBER,
                    "max_points": NUMBER,
                    "message": TEXT,
                    "output": TEXT,
                    "images": IMAGES,
                },
            },
        },
    },
}

UUID = {
    "type": "string",
    "pattern": "^[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}$",
}

QUESTION = {  # "Question configuration": of info.json, what a question with an external grader has
    "type": "object",
    "additionalProperties": False,
    "required": ["uuid", "type", "title", "topic"],
    "properties": {
        "uuid": UUID,
        "type": {"const": "v3"},
        "title": TEXT,
        "topic": TEXT,
        "tags": {"type": "array", "items": TEXT},
        "gradingMethod": {"enum": ["Internal", "External", "Manual"]},
        "singleVariant": {"type": "boolean"},
        "showCorrectAnswer": {"type": "boolean"},
        "partialCredit": {"type": "boolean"},
        "externalGradingOptions": {
            "type": "object",
            "additionalProperties": False,
            "required": ["image", "entrypoint"],
            "properties": {
                "enabled": {"type": "boolean"},
                "image": TEXT,
                "entrypoint": {"anyOf": [TEXT, {"type": "array", "items": TEXT}]},
                "serverFilesCourse": {"type": "array", "items": TEXT},
                "timeout": {"type": "integer", "minimum": 1, "maximum": 600},
                "enableNetworking": {"type": "boolean"},
                "environment": {"type": "object"},
            },
        },
    },
}

MOMENT = {"type": "string", "pattern": r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d$"}

ASSESSMENT = {  # "Assessment configuration", "Access control": of infoAssessment.json, what is used
    "type": "object",
    "additionalProperties": False,
    "required": ["uuid", "type", "title", "set", "number"],
    "properties": {
        "uuid": UUID,
        "type": {"enum": ["Homework", "Exam"]},
        "title": TEXT,
        "set": TEXT,
        "number": TEXT,
        "allowAccess": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "startDate": MOMENT,
                    "endDate": MOMENT,
                    "credit": {"type": "integer"},
                },
            },
        },
        "zones": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "required": ["questions"],
                "properties": {
                    "questions": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "additionalProperties": False,
                            "required": ["id", "autoPoints"],
                            "properties": {"id": TEXT, "autoPoints": NUMBER},
                        },
                    }
                },
            },
        },
    },
}

# Jenkins' schema of JUnit (its xUnit plugin, junit-10.xsd): of an element what it may have, what it
# must, and what is in it
JUNIT = {
    "testsuites": ({"name", "time", "tests", "failures", "errors"}, set(), {"testsuite"}),
    "testsuite": (
        {
            "name",
            "tests",
            "failures",
            "errors",
            "group",
            "time",
            "skipped",
            "timestamp",
            "hostname",
            "id",
            "package",
            "file",
            "log",
            "url",
        },
        {"name", "tests", "failures", "errors"},
        {"testsuite", "properties", "testcase", "system-out", "system-err"},
    ),
    "testcase": (
        {"name", "time", "classname", "group"},
        {"name"},
        {
            "skipped",
            "error",
            "failure",
            "rerunFailure",
            "rerunError",
            "flakyFailure",
            "flakyError",
            "system-out",
            "system-err",
        },
    ),
    "failure": ({"type", "message"}, set(), set()),
    "error": ({"type", "message"}, set(), set()),
    "system-err": (set(), set(), set()),
}


def departures(root: Element) -> Iterator[str]:
    """Yield where JUnit XML is not as JUNIT says: elements, attributes, text, and sums that are not
    the sums.
    """
    if root.tag not in ("testsuites", "testsuite"):
        yield f"the root is {root.tag}"
    for element in root.iter():
        may, must, within = JUNIT.get(element.tag, (set(), set(), set()))
        if element.tag not in JUNIT:
            yield f"no element is named {element.tag}"
        if not must <= set(element.attrib) <= may:
            yield f"{element.tag} has {sorted(element.attrib)}"
        if not {child.tag for child in element} <= within:
            yield f"{element.tag} holds {[child.tag for child in element]}"
        if within and (element.text or "").strip():
            yield f"{element.tag} has text"
    for suite in root.iter("testsuite"):
        counted = {"tests": "testcase", "failures": "testcase/failure", "errors": "testcase/error"}
        for name, path in counted.items():
            if int(suite.get(name, "-1")) != len(suite.findall(path)):
                yield f"{name} of {suite.get('name')} is {suite.get(name)}"
