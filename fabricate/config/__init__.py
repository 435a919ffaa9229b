"""Everything a run can be asked: each key with default, bounds and one line of meaning; and reading it."""

from fabricate.config.config import Config
from fabricate.config.curve_config import CurveConfig
from fabricate.config.field_config import (
    AttributeConfig,
    CurvatureConfig,
    DirectionConfig,
    DistanceConfig,
    FieldConfig,
    HeightConfig,
    ImageConfig,
)
from fabricate.config.loading import load_config
from fabricate.config.lock_config import LockConfig, SideConfig
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.config.pattern_config import PatternConfig
from fabricate.config.prepare_config import PrepareConfig
from fabricate.config.process_config import ProcessConfig
from fabricate.config.resolved import config_sha256, moved_config, resolved_toml
from fabricate.config.shop_config import ShopConfig
from fabricate.config.solid_config import SolidConfig, ThicknessConfig, TongueConfig
from fabricate.config.source_config import (
    CubeConfig,
    FileConfig,
    FrameConfig,
    KnotConfig,
    SourceConfig,
    SphereConfig,
    TorusConfig,
)

__all__ = [
    "AttributeConfig",
    "Config",
    "CubeConfig",
    "CurvatureConfig",
    "CurveConfig",
    "DirectionConfig",
    "DistanceConfig",
    "FieldConfig",
    "FileConfig",
    "FrameConfig",
    "HeightConfig",
    "ImageConfig",
    "KnotConfig",
    "LockConfig",
    "OptimiseConfig",
    "PatternConfig",
    "PrepareConfig",
    "ProcessConfig",
    "ShopConfig",
    "SideConfig",
    "SolidConfig",
    "SourceConfig",
    "SphereConfig",
    "ThicknessConfig",
    "TongueConfig",
    "TorusConfig",
    "config_sha256",
    "load_config",
    "moved_config",
    "resolved_toml",
]
