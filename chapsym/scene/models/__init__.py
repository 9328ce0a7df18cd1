"""The models that a scene may need, one file each; `MODELS` has them in the order in which they are tried."""

from .chosen import Chosen
from .general import General
from .model import Model, State
from .rolling import Rolling
from .steady import Steady
from .vertical import Vertical

#: The least first: the first that does not refuse is taken.
MODELS: tuple[Model, ...] = (Chosen(), General(), Steady(), Vertical(), Rolling())

__all__ = ["MODELS", "Chosen", "General", "Model", "Rolling", "State", "Steady", "Vertical"]
