"""The one error tree: every failure that a user can cause is a `FabricateError` with a readable message."""


class FabricateError(Exception):
    """Root of all errors raised on purpose; its text is one line that says what to do."""


class ConfigError(FabricateError, ValueError):
    """A config file, key or value is wrong."""


class ReadError(FabricateError, ValueError):
    """A file is missing, is not a mesh, or is damaged."""


class MeshError(FabricateError, ValueError):
    """A mesh is not one closed, orientable 2-manifold with volume."""


class PrepareError(FabricateError, ValueError):
    """A mesh cannot be repaired or remeshed as asked."""


class PatternError(FabricateError, ValueError):
    """A duotone pattern cannot be made on this mesh with these options."""


class SolidError(FabricateError, ValueError):
    """A solid cannot be made with this thickness or clearance."""


class OutputError(FabricateError, OSError):
    """A result cannot be written."""
